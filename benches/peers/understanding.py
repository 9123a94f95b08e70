"""Other learners on the same splits as `goodbot evaluate`: logistic regression over words, a recurrent network over words, and a conditional logit
over the possible tasks.

    pip install scikit-learn==1.9.1
    pip install jax==0.10.2 equinox==0.13.8 optax==0.2.8    (the recurrent network, which may be missing)
    python benches/peers/understanding.py [--curve] GOODBOT FILE.jsonl...
    python benches/peers/understanding.py --covered FILE.jsonl...

GOODBOT is the program. Each FILE is a log of homes or of worlds. goodbot is evaluated in ten parts; the order of its answers gives the parts, and
the peers learn and are asked the same sessions. Their regularization (the pull to 0) and the network's settings are chosen within the training
data, in three parts. Standard output: a table of accuracy (log loss). With --curve, for logs of homes: accuracy after 8 to 128 commands, the
means of five orders, which are those of `goodbot evaluate --curve`. With --covered, for logs of worlds: the number of commands each part of
whose meaning also occurs in another group's meaning.
"""
import collections
import itertools
import json
import re
import subprocess
import sys

import numpy as np
from scipy.optimize import minimize
from sklearn.feature_extraction.text import CountVectorizer
from sklearn.linear_model import LogisticRegression

PULLS = (0.1, 0.3, 1.0, 3.0)
TWO_GOALS = "agentInRoom(?a,?r1) & blockInRoom(?o,?r2)"
PARTS = 10
SIZES = (8, 16, 32, 64, 128)
ORDERS = 5


class Session:
    """A command, the names of the possible tasks, the parts of each, and the position of the intended one."""

    def __init__(self, record, names, parts, group):
        self.name, self.command, self.names, self.parts, self.group = record["id"], record["command"], names, parts, group
        wanted = tuple(sorted(record["intended"]))
        self.meant = names.index(wanted) if wanted in names else None

    def label(self):
        return " ".join(map(str, self.parts[self.meant]))


def room_of(thing, rooms):
    inside = (room for room in rooms if room["left"] <= thing["x"] <= room["right"] and room["bottom"] <= thing["y"] <= room["top"])
    return next(inside, {"color": "none"})


def tasks_of_home(home):
    """Tasks of the paper's kinds and of two goals, with each object's values by its role."""
    of = lambda kind: [it for it in home["objects"] if it["class"] == kind]
    rooms, blocks, agent = of("room"), of("block"), of("agent")[0]
    tasks = []
    go = lambda room: f"agentInRoom({agent['name']},{room['name']})"
    take = lambda block, room: f"blockInRoom({block['name']},{room['name']})"
    block_parts = lambda block: [("block", block["color"]), ("block", block["shape"]), ("from", room_of(block, rooms)["color"])]
    there = lambda role, room, but: [(role, it[a]) for it in blocks if it is not but and room_of(it, rooms) is room for a in ("color", "shape")]
    for room in rooms:
        tasks.append(((go(room),), [("kind", "go"), ("agent to", room["color"])] + there("there", room, None)))
        for block in blocks:
            parts = [("kind", "take"), ("block to", room["color"])] + block_parts(block) + there("there", room, block)
            tasks.append(((take(block, room),), parts))
            for other in rooms:
                if other is not room:
                    both = [("kind", "both"), ("agent to", other["color"]), ("block to", room["color"])] + block_parts(block)
                    tasks.append((tuple(sorted((go(other), take(block, room)))), both))
    return [name for name, _ in tasks], [sorted(set(parts)) for _, parts in tasks]


def tasks_of_world(world, facts):
    """Tasks of a world: the words of the proposition's name, and each object's values and facts by its place."""
    objects, alone = {it["name"]: it for it in world["objects"]}, collections.defaultdict(list)
    for fact in facts:
        function, arguments = re.match(r"(\w+)\((.*)\)$", fact).groups()
        if "," not in arguments:
            alone[arguments].append(function)
    names, parts = [], []
    for kind in world["task_kinds"]:
        function = re.match(r"\w+", kind)[0]
        choices = ([it["name"] for it in world["objects"] if it["class"] == wanted] for wanted in world["propositions"][function])
        for bound in itertools.product(*choices):
            name = f"{function}({','.join(bound)})"
            if len(set(bound)) < len(bound) or name in facts:
                continue
            said = [("is", word) for word in re.findall(r"[A-Z]?[a-z]+", function)]
            for place, it in enumerate(bound):
                for attribute, value in objects[it]["attributes"].items():
                    said += [(f"{place} {attribute}", value)] + [(f"{place} {attribute} is", fact) for fact in alone[value]]
                said += [(f"{place} is", fact) for fact in alone[it]]
            names.append((name,))
            parts.append(sorted(set(said)))
    return names, parts


def read(path):
    worlds, known, sessions = {}, {}, []
    for line in open(path, encoding="utf-8"):
        record = json.loads(line)
        if record["type"] == "world":
            worlds[record["name"]] = record
        elif record["type"] == "command":
            world = worlds[record["world"]]
            facts = record.get("facts", world.get("facts", []))
            key = (record["world"], tuple(sorted(facts)))
            if key not in known:
                known[key] = tasks_of_world(world, set(facts))
            sessions.append(Session(record, *known[key], record.get("group", record["id"])))
        elif record["type"] == "session":
            key = json.dumps(record["environment"])
            if key not in known:
                known[key] = tasks_of_home(record["environment"])
            sessions.append(Session(record, *known[key], record["id"]))
    return sessions, bool(worlds)


def evaluate(program, path, *options):
    command = [program, "evaluate", path, "--keep-going", *options]
    return subprocess.run(command, capture_output=True, check=True, encoding="utf-8")


def goodbot(program, path, *options):
    """The answers and the summary."""
    return [json.loads(line) for line in evaluate(program, path, "--json", *options).stdout.splitlines()]


def parts_of(lines, sessions, count):
    """The answers come part by part. If parts cannot be of equal size, the first ones have one more session or group."""
    by_name = {it.name: it for it in sessions}
    asked = [by_name[line["session"]] for line in lines if line["type"] == "answer"]
    groups = list(dict.fromkeys(it.group for it in asked))
    count = min(count, len(groups))
    sizes = [len(groups) // count + (part < len(groups) % count) for part in range(count)]
    ends = np.cumsum(sizes)
    part_of = {group: int(np.searchsorted(ends, position, side="right")) for position, group in enumerate(groups)}
    return [[it for it in asked if part_of[it.group] == part] for part in range(count)]


def logistic(taught, asked, pull):
    """Logistic regression: the words alone choose among the meanings in the training data."""
    labels = sorted({it.label() for it in taught})
    if len(labels) == 1:
        return [(it.label() in labels, 0.999 if it.label() in labels else 0.001) for it in asked]
    words = CountVectorizer(binary=True, token_pattern=r"(?u)[^\W_]+")
    matrix = words.fit_transform(it.command for it in taught)
    model = LogisticRegression(C=1 / pull, max_iter=500).fit(matrix, [it.label() for it in taught])
    shares = model.predict_proba(words.transform(it.command for it in asked))
    place = {label: position for position, label in enumerate(model.classes_)}
    result = []
    for it, row in zip(asked, shares):
        # Meanings outside the training data share a thousandth, because the regression gives them no probability.
        share = 0.999 * row[place[it.label()]] if it.label() in place else 0.001
        result.append((labels[int(row.argmax())] == it.label(), share))
    return result


def conditional(taught, asked, pull):
    """A conditional logit: a weight for each word with each part of a task, over the possible tasks of each session."""
    dims, words = {}, {}
    tokens = lambda it: {"#"} | set(re.findall(r"[^\W_]+", it.command.lower()))
    for it in taught + asked:
        for part in itertools.chain.from_iterable(it.parts):
            dims.setdefault(part, len(dims))
    for it in taught:
        for word in tokens(it):
            words.setdefault(word, len(words))
    tables = {}
    for it in taught + asked:
        if id(it.parts) not in tables:
            table = np.zeros((len(it.parts), len(dims)))
            for task, parts in enumerate(it.parts):
                table[task, [dims[part] for part in parts]] = 1
            tables[id(it.parts)] = table
    heard = np.zeros((len(taught), len(words)))
    alike = collections.defaultdict(list)
    for number, it in enumerate(taught):
        heard[number, [words[word] for word in tokens(it)]] = 1
        alike[id(it.parts)].append(number)

    def loss(flat):
        weights = flat.reshape(len(words), len(dims))
        scores, slopes, whole = heard @ weights, np.zeros((len(taught), len(dims))), 0.0
        for key, numbers in alike.items():
            shares = scores[numbers] @ tables[key].T
            shares = np.exp(shares - shares.max(1, keepdims=True))
            shares /= shares.sum(1, keepdims=True)
            rows, meant = np.arange(len(numbers)), [taught[number].meant for number in numbers]
            whole -= np.log(shares[rows, meant] + 1e-30).sum()
            shares[rows, meant] -= 1
            slopes[numbers] = shares @ tables[key]
        return whole + 0.5 * pull * (weights**2).sum(), (heard.T @ slopes + pull * weights).ravel()

    fitted = minimize(loss, np.zeros(len(words) * len(dims)), jac=True, method="L-BFGS-B", options={"maxiter": 60})
    weights, result = fitted.x.reshape(len(words), len(dims)), []
    for it in asked:
        known = [words[word] for word in tokens(it) if word in words]
        scores = tables[id(it.parts)] @ weights[known].sum(0)
        shares = np.exp(scores - scores.max())
        shares /= shares.sum()
        result.append((int(shares.argmax()) == it.meant, shares[it.meant]))
    return result


def summed(answers):
    right, loss = np.mean([right for right, _ in answers]), np.mean([-np.log(max(share, 1e-6)) for _, share in answers])
    return right, loss


def each(learner):
    """The answers for each pull."""
    return lambda taught, asked, pulls: {pull: learner(taught, asked, pull) for pull in pulls}


def answers_of(learner, settings, taught, asked):
    """The answers for the setting with the least loss within the training data."""
    groups, losses = list(dict.fromkeys(it.group for it in taught)), collections.Counter()
    for start in range(3):
        left = [it for it in taught if it.group in set(groups[start::3])]
        for setting, answers in learner([it for it in taught if it not in left], left, settings).items():
            losses[setting] -= sum(np.log(max(share, 1e-6)) for _, share in answers)
    best = min(settings, key=losses.get)
    return learner(taught, asked, [best])[best]


def peers():
    """Each peer's name, its answers, its settings, and whether it chooses by words alone."""
    yield "logistic regression", each(logistic), PULLS, True
    try:
        import recurrent
    except ImportError as missing:
        print(f"There is no recurrent network: {missing}. The top of this script says what it needs.", file=sys.stderr)
    else:
        yield "recurrent network", recurrent.answers, recurrent.SETTINGS, True
    yield "conditional logit", each(conditional), PULLS, False


def table(program, paths):
    learners = list(peers())
    print(f"| log | commands | {' | '.join(name for name, *_ in learners)} | goodbot |\n|---|---:|{'---:|' * (len(learners) + 1)}")
    for path in paths:
        sessions, worlds = read(path)
        *lines, summary = goodbot(program, path, *([] if worlds else ["--k-fold", str(PARTS), "--task", TWO_GOALS]))
        parts = parts_of(lines, sessions, PARTS)
        cells = []
        for _, learner, settings, by_words in learners:
            # In logs of worlds no asked meaning is in the training data, so words alone cannot be right.
            if worlds and by_words:
                cells.append("-")
                continue
            taught = lambda part: [it for other in parts if other is not part for it in other]
            right, loss = summed([answer for part in parts for answer in answers_of(learner, settings, taught(part), part)])
            cells.append(f"{100 * right:.1f} % ({loss:.3f})")
        cells.append(f"{100 * summary['accuracy']:.1f} % ({summary['log_loss']:.3f})")
        print(f"| {name_of(path)} | {sum(map(len, parts))} | {' | '.join(cells)} |", flush=True)


def order_of(parts):
    """The order of a curve with this seed. It was dealt into the parts like cards, one session each in turn."""
    return [it for dealt in itertools.zip_longest(*parts) for it in dealt if it]


def curves(program, paths):
    print(f"| log | learner | {' | '.join(map(str, SIZES))} |\n|---|---|{'---:|' * len(SIZES)}")
    for path in paths:
        sessions, halves = read(path)[0], ["--k-fold", "2", "--task", TWO_GOALS]
        # Only the order of these answers matters; it is the same for every learner.
        dealt = lambda seed: goodbot(program, path, *halves, "--seed", str(seed), "--learner", "roles")
        orders = [order_of(parts_of(dealt(seed), sessions, 2)) for seed in range(1, ORDERS + 1)]
        for name, learner, settings, _ in peers():
            cells = []
            for size in SIZES:
                rights = [summed(answers_of(learner, settings, order[:size], order[size:]))[0] for order in orders]
                cells.append(f"{100 * np.mean(rights):.1f}")
            print(f"| {name_of(path)} | {name} | {' | '.join(cells)} |", flush=True)
        # With the picture on standard output, the text goes to standard error.
        told = evaluate(program, path, *halves, "--curve", "-", "--runs", str(ORDERS)).stderr
        points = dict(re.findall(r"^ *(\d+)  ([\d.]+) % ±", told, re.MULTILINE))
        print(f"| {name_of(path)} | goodbot | {' | '.join(points[str(size)] for size in SIZES)} |", flush=True)


def covered(paths):
    """Counts the commands each part of whose meaning also occurs in another group's meaning."""
    for path in paths:
        meant = [(it.group, it.parts[it.meant]) for it in read(path)[0] if it.meant is not None]
        groups = collections.defaultdict(set)
        for group, parts in meant:
            for part in parts:
                groups[part].add(group)
        count = sum(all(len(groups[part]) > 1 for part in parts) for _, parts in meant)
        print(f"| {name_of(path)} | {count} of {len(meant)} | {100 * count / len(meant):.0f} % |")


def name_of(path):
    return path.rsplit("/", 1)[-1].removesuffix(".jsonl")


def main():
    arguments = [it for it in sys.argv[1:] if it not in ("--curve", "--covered")]
    if "--covered" in sys.argv:
        covered(arguments)
    else:
        (curves if "--curve" in sys.argv else table)(arguments[0], arguments[1:])


if __name__ == "__main__":
    main()
