"""Planning problems as worlds: the robot's plans are as long as those of a known planner, pyperplan, which looks breadth first."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

import goodbot

PROBLEMS = ["blocks-3", "carry-3", "ferry-3", "gripper-4", "logistics-1", "visitall-6"]

# What goodbot does not convert: a switch for all lamps of a room, and a look from a bright room or once every lamp is on.
HOUSE = """(define (domain house)
  (:requirements :strips :typing :disjunctive-preconditions :conditional-effects :universal-preconditions)
  (:types lamp room)
  (:predicates (on ?l - lamp) (in ?l - lamp ?r - room) (at ?r - room) (seen) (bright ?r - room))
  (:action go :parameters (?from ?to - room) :precondition (at ?from) :effect (and (at ?to) (not (at ?from))))
  (:action switch :parameters (?r - room) :precondition (at ?r) :effect (forall (?l - lamp) (when (in ?l ?r) (on ?l))))
  (:action look :parameters (?r - room) :precondition (and (at ?r) (or (bright ?r) (forall (?l - lamp) (on ?l)))) :effect (seen)))"""
THREE = """(define (problem three) (:domain house) (:objects a b c - lamp kitchen hall - room)
  (:init (at kitchen) (in a kitchen) (in b hall) (in c hall)) (:goal (and (seen))))"""


def converted(cli: str, domain: Path, problem: Path) -> goodbot.World:
    done = subprocess.run([cli, "convert", "--quiet", domain, problem], check=True, capture_output=True, text=True)
    return goodbot.World.from_json(done.stdout)


def goal(problem: str) -> str:
    """The goal as a task: `(:goal (and (at a b) (lit)))` is `at(a,b) & lit(whole)`."""
    atoms = re.findall(r"\(([^()]+)\)", problem.split("(:goal")[1])
    return " & ".join(f"{name}({','.join(terms) or 'whole'})" for name, *terms in (atom.split() for atom in atoms))


@pytest.mark.parametrize("name", PROBLEMS)
def test_plans_are_as_long_as_those_of_a_known_planner(name: str, root: Path, cli: str, tmp_path: Path) -> None:
    domain, problem = (root / f"lesson/tests/pddl/{file}.pddl" for file in (name.split("-")[0], name))
    plan = converted(cli, domain, problem).plan(goal(problem.read_text()))
    # It knows no inequalities. A ferry that sails to where it is makes no plan shorter.
    (tmp_path / "domain.pddl").write_text(domain.read_text().replace("(not (= ?from ?to))", ""))
    (tmp_path / "problem.pddl").write_text(problem.read_text())
    subprocess.run([sys.executable, "-m", "pyperplan", "--search", "bfs", "domain.pddl", "problem.pddl"], cwd=tmp_path, check=True)
    assert plan is not None and len(plan) == len((tmp_path / "problem.pddl.soln").read_text().splitlines())


def test_a_world_is_made_of_two_files(root: Path, cli: str, tmp_path: Path) -> None:
    domain, problem = (root / f"lesson/tests/pddl/{file}.pddl" for file in ("gripper", "gripper-4"))
    world = goodbot.World.from_pddl(domain, problem)
    assert world == converted(cli, domain, problem) and world.plan("at(ball1,roomb)")
    wrong, useless = tmp_path / "wrong.pddl", tmp_path / "useless.pddl"
    wrong.write_text(problem.read_text().replace("(at-robby rooma)", "(at-robby cellar)"))
    with pytest.raises(goodbot.FormatError, match=r"wrong.pddl:\d+: cellar in \(at-robby cellar\) is no object") as raised:
        goodbot.World.from_pddl(domain, wrong)
    assert raised.value.line > 1
    useless.write_text(problem.read_text().replace("(at ball2 roomb)", "(at ball1 rooma)"))
    with pytest.warns(UserWarning, match="no plan reaches the goal"):
        goodbot.World.from_pddl(domain, useless)
    with pytest.raises(FileNotFoundError):
        goodbot.World.from_pddl(domain, tmp_path / "none.pddl")


def test_the_recipe_of_the_cookbook_simplifies_a_problem(root: Path, cli: str, tmp_path: Path) -> None:
    for file, text in (("domain.pddl", HOUSE), ("problem.pddl", THREE)):
        (tmp_path / file).write_text(text)
    refused = subprocess.run([cli, "convert", "domain.pddl", "problem.pddl"], cwd=tmp_path, capture_output=True, text=True)
    assert refused.returncode != 0 and '"forall" is not understood' in refused.stderr
    [recipe] = re.findall(r"`python (python/examples/strips.py .*)`", (root / "docs/cookbook.md").read_text(encoding="utf-8"))
    script, *files = recipe.split()
    subprocess.run([sys.executable, root / script, *files], cwd=tmp_path, check=True)
    plan = converted(cli, *(tmp_path / file for file in files[2:])).plan("seen(whole)")
    # Switch, go, switch, look.
    assert plan is not None and len(plan) == 4
