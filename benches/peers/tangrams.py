"""The tangrams of SCONE as a log of worlds in which each instruction means one task: `python benches/peers/tangrams.py LOG > tasks.jsonl`.

LOG is a log of worlds, whose commands record the row of figures before and after. Each instruction removes a figure from the row, exchanges two, or puts
back a removed one. A world here is one row. Its figures, and the places where one can be put back, have their number from the left and from the right, and
their end. The names of commands whose sentence has a word of MEMORY begin with `needs-`. With --alone, no command names those before it.
"""
import json
import re
import sys

# Words that refer to an earlier step.
MEMORY = set(
    "again back before deleted it its other previous previously redo removed repeat replace same step steps swapped that them undo".split()
)
KINDS = ["removed(?f)", "swapped(?f) & swapped(?g)", "added(?p,?o)"]


def row_of(facts):
    places = (re.match(r"figure\(p(\d+),(\w+)\)$", fact).groups() for fact in facts)
    return [figure for _, figure in sorted((int(number), figure) for number, figure in places)]


def values(number, count):
    end = "left" if number == 1 else "right" if number == count else "middle" if 2 * number == count + 1 else None
    return {"number": str(number), "fromRight": str(count + 1 - number)} | ({"end": end} if end else {})


def world_of(row, figures, old):
    objects = [{"name": figure, "class": "figure", "attributes": values(number, len(row))} for number, figure in enumerate(row, 1)]
    objects += [{"name": f"p{number}", "class": "place", "attributes": values(number, len(row) + 1)} for number in range(1, len(row) + 2)]
    objects += [{"name": figure, "class": "out", "attributes": {}} for figure in figures if figure not in row]
    return {
        "type": "world",
        "name": " ".join(row) or "empty",
        "classes": ["figure", "place", "out"],
        "attributes": {name: ["figure", "place"] for name in ("number", "fromRight", "end")},
        "propositions": {"removed": ["figure"], "swapped": ["figure"], "added": ["place", "out"], "at": ["figure", "place"]},
        "objects": objects,
        "facts": [f"at({figure},p{number})" for number, figure in enumerate(row, 1)],
        "task_kinds": KINDS,
        "license": old["license"],
        "source": old["source"],
    }


def task_of(before, after):
    """The propositions of the instruction that changed one row into the other."""
    if len(after) < len(before):
        (gone,) = set(before) - set(after)
        return [f"removed({gone})"]
    if len(after) > len(before):
        (new,) = set(after) - set(before)
        return [f"added(p{after.index(new) + 1},{new})"]
    return [f"swapped({figure})" for figure, other in zip(before, after) if figure != other]


def named(name, command):
    return f"needs-{name}" if MEMORY & set(re.findall(r"[a-z]+", command.lower())) else name


def main(path, alone):
    old, known, names = None, set(), {}
    for record in map(json.loads, open(path, encoding="utf-8")):
        if record["type"] == "world":
            old, figures = record, [it["name"] for it in record["objects"] if it["class"] == "figure"]
            continue
        before = row_of(record["facts"])
        after = row_of((set(record["facts"]) - set(record["ended"])) | set(record["intended"]))
        world = world_of(before, figures, old)
        if world["name"] not in known:
            known.add(world["name"])
            print(json.dumps(world))
        names[record["id"]] = named(record["id"], record["command"])
        told = {key: record[key] for key in ("type", "group", "language", "command")}
        told |= {"world": world["name"], "id": names[record["id"]], "intended": task_of(before, after)}
        print(json.dumps(told if alone else told | {"before": [names[id] for id in record["before"]]}))


if __name__ == "__main__":
    main(next(it for it in sys.argv[1:] if it != "--alone"), "--alone" in sys.argv)
