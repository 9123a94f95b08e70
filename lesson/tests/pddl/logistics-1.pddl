; A package from an office to another city's office: truck, plane, truck.
(define (problem logistics-1) (:domain logistics)
  (:objects paris london - city cdg lhr - airport louvre museum - location truck1 truck2 - truck plane - airplane parcel - package)
  (:init (in-city cdg paris) (in-city louvre paris) (in-city lhr london) (in-city museum london)
    (at truck1 cdg) (at truck2 lhr) (at plane lhr) (at parcel louvre))
  (:goal (at parcel museum)))
