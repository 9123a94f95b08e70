(define (problem ferry-3) (:domain ferry)
  (:objects car1 car2 car3 - car north south east - place)
  (:init (at-ferry north) (empty-ferry) (at car1 south) (at car2 south) (at car3 east))
  (:goal (and (at car1 north) (at car2 east))))
