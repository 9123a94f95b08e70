"""A recurrent network as the language of `goodbot study`: a GRU reads the command, and its last state is compared with the facts of each task.

    pip install jax==0.10.2 equinox==0.13.8 optax==0.2.8
    goodbot study --program "python benches/peers/gru.py" --program-runs 30

It is trained anew after each lesson, on all lessons so far, each with the belief at its end. Of the rates 0.002, 0.005,
0.01 and 0.03, 0.005 was best on the seeds of `goodbot study --tune`.
"""
import argparse
import json
import sys

import equinox
import jax
import jax.numpy as jnp
import numpy as np
import optax

STATE = 32
# So that one program is compiled: the most lessons, words of a command, tasks, facts of a task, and known words and facts.
LESSONS, LONG, TASKS, FACTS, KNOWN = 10, 10, 16, 4, 128
PADDING = 0


class Network(equinox.Module):
    words: equinox.nn.Embedding
    cell: equinox.nn.GRUCell
    facts: equinox.nn.Embedding

    def __init__(self, key):
        keys = jax.random.split(key, 3)
        self.words = equinox.nn.Embedding(KNOWN, STATE, key=keys[0])
        self.cell = equinox.nn.GRUCell(STATE, STATE, key=keys[1])
        self.facts = equinox.nn.Embedding(KNOWN, STATE, key=keys[2])

    def __call__(self, words, tasks):
        read = lambda state, word: (jnp.where(word == PADDING, state, self.cell(self.words.weight[word], state)), None)
        state, _ = jax.lax.scan(read, jnp.zeros(STATE), words)
        # A fact has about unit length, so that long and short tasks begin alike.
        alike = (self.facts.weight[tasks] @ state) * (tasks != PADDING) / np.sqrt(STATE)
        return jnp.where(tasks[:, 0] == PADDING, -1e9, alike.sum(axis=1))


@jax.jit
def trained(words, tasks, beliefs):
    """A network trained on these lessons; the belief in an unused one is 0."""
    def loss(network):
        return -(beliefs * jax.nn.log_softmax(jax.vmap(network)(words, tasks))).sum() / beliefs.sum()

    def step(_, kept):
        network, state = kept
        change, state = adam.update(jax.grad(loss)(network), state)
        return optax.apply_updates(network, change), state

    network, adam = Network(jax.random.key(0)), optax.adam(options.rate)
    return jax.lax.fori_loop(0, options.steps, step, (network, adam.init(network)))[0]


@jax.jit
def heard(network, words, tasks):
    return jax.nn.log_softmax(network(words, tasks))


class Language:
    def __init__(self):
        self.known = {}
        self.lessons = []
        self.network = None

    def numbers(self, names, most):
        numbers = [self.known.setdefault(name, len(self.known) + 1) for name in names][:most]
        if len(self.known) >= KNOWN:
            sys.exit(f"there are {len(self.known)} words and facts; raise KNOWN")
        return numbers + [PADDING] * (most - len(numbers))

    def read(self, words, tasks):
        rows = [self.numbers([f"fact {fact}" for fact in facts], FACTS) for facts in tasks]
        return np.array(self.numbers(words, LONG)), np.array(rows + [[PADDING] * FACTS] * (TASKS - len(rows)))

    def log_likelihood(self, words, tasks):
        if not self.lessons:
            return [0.0] * len(tasks)
        if self.network is None:
            filled = [np.zeros((LESSONS, *part.shape), part.dtype) for part in self.lessons[0]]
            for at, lesson in enumerate(self.lessons):
                for whole, part in zip(filled, lesson):
                    whole[at] = part
            self.network = trained(*filled)
        return [float(number) for number in heard(self.network, *self.read(words, tasks))[: len(tasks)]]

    def learn(self, words, tasks, beliefs):
        self.lessons.append((*self.read(words, tasks), np.array(beliefs + [0.0] * (TASKS - len(tasks)), np.float32)))
        self.network = None


parser = argparse.ArgumentParser(description="a GRU as the language of goodbot study")
parser.add_argument("--rate", type=float, default=0.005, help="Adam's rate")
parser.add_argument("--steps", type=int, default=60, help="training steps after each lesson")
options = parser.parse_args()
language = Language()
for line in sys.stdin:
    request = json.loads(line)
    if request["type"] == "begin":
        language = Language()
    elif request["type"] == "learn":
        language.learn(request["words"], request["tasks"], request["beliefs"])
    else:
        print(json.dumps(language.log_likelihood(request["words"], request["tasks"])), flush=True)
