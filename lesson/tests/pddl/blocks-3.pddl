; Sussman's anomaly.
(define (problem blocks-3) (:domain blocks)
  (:objects a b c)
  (:init (on c a) (ontable a) (ontable b) (clear b) (clear c) (handempty))
  (:goal (and (on a b) (on b c))))
