"""Writes a planning problem without `when`, `or` and `forall`, so that `goodbot convert` understands it.

python strips.py DOMAIN PROBLEM NEW_DOMAIN NEW_PROBLEM    needs pip install unified-planning
"""

import sys

from unified_planning.io import PDDLReader, PDDLWriter
from unified_planning.shortcuts import CompilationKind, Compiler, get_environment

get_environment().credits_stream = None
domain, problem, new_domain, new_problem = sys.argv[1:]
simple = PDDLReader().parse_problem(domain, problem)
for kind in ("QUANTIFIERS_REMOVING", "CONDITIONAL_EFFECTS_REMOVING", "DISJUNCTIVE_CONDITIONS_REMOVING"):
    with Compiler(problem_kind=simple.kind, compilation_kind=CompilationKind[kind]) as compiler:
        simple = compiler.compile(simple).problem
writer = PDDLWriter(simple)
writer.write_domain(new_domain)
writer.write_problem(new_problem)
