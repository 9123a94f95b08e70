(define (problem three) (:domain carry) (:objects a b x y z l)
(:init (room a) (room b) (ball x) (ball y) (ball z) (hand l) (empty l) (here a) (at x a) (at y a) (at z a))
(:goal (and (at x b) (at y b) (at z b))))
