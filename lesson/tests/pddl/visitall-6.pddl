; Two by three places; the ends of a way that must turn back.
(define (problem visitall-6) (:domain visitall)
  (:objects p00 p01 p02 p10 p11 p12 - place)
  (:init (at-robot p01) (visited p01)
    (connected p00 p01) (connected p01 p00) (connected p01 p02) (connected p02 p01) (connected p10 p11) (connected p11 p10)
    (connected p11 p12) (connected p12 p11) (connected p00 p10) (connected p10 p00) (connected p02 p12) (connected p12 p02))
  (:goal (and (visited p00) (visited p02))))
