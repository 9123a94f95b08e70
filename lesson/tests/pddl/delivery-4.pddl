; The short way from home to the office leads through a shop that is shut; by the park it costs 4 + 5, and directly 12.
(define (problem delivery-4) (:domain delivery)
  (:objects home shop park office - place)
  (:init (robot-at home) (has-letter home) (shut shop)
    (road home shop) (= (length home shop) 1) (road shop office) (= (length shop office) 1)
    (road home park) (= (length home park) 4) (road park office) (= (length park office) 5)
    (road home office) (= (length home office) 12) (= (total-cost) 0))
  (:goal (has-letter office))
  (:metric minimize (total-cost)))
