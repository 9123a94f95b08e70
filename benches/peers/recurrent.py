"""A recurrent network, for understanding.py: a GRU reads word by word; its last state chooses among the meanings in the training data.

    pip install jax==0.10.2 equinox==0.13.8 optax==0.2.8
"""
import collections
import re

import equinox
import jax
import jax.numpy as jnp
import numpy as np
import optax

# The dropout rate of the last state (words: half of it) during training, and the number of training steps.
SETTINGS = [(left_out, steps) for left_out in (0.2, 0.5) for steps in (150, 300, 600)]
EMBEDDED, STATE, BATCH, RATE, NETWORKS = 64, 64, 16, 2e-3, 3
# Sizes are rounded up to multiples of these, so that few programs are compiled: words in a sentence, known words, meanings.
LONG, KNOWN, MEANINGS = 16, 128, 16
PADDING, UNKNOWN = 0, 1


class Network(equinox.Module):
    words: equinox.nn.Embedding
    cell: equinox.nn.GRUCell
    meanings: equinox.nn.Linear

    def __init__(self, words, meanings, key):
        keys = jax.random.split(key, 3)
        self.words = equinox.nn.Embedding(words, EMBEDDED, key=keys[0])
        self.cell = equinox.nn.GRUCell(EMBEDDED, STATE, key=keys[1])
        self.meanings = equinox.nn.Linear(STATE, meanings, key=keys[2])

    def __call__(self, sentence, left_out=0.0, key=None):
        if key is not None:
            keys = jax.random.split(key)
            # A dropped word becomes the unknown word, whose embedding is learned from these.
            forgotten = jax.random.bernoulli(keys[0], left_out / 2, sentence.shape) & (sentence != PADDING)
            sentence = jnp.where(forgotten, UNKNOWN, sentence)
        read = lambda state, word: (jnp.where(word[0] == PADDING, state, self.cell(word[1], state)), None)
        state, _ = jax.lax.scan(read, jnp.zeros(STATE), (sentence, jax.vmap(self.words)(sentence)))
        if key is not None:
            state = jnp.where(jax.random.bernoulli(keys[1], left_out, state.shape), 0, state / (1 - left_out))
        return self.meanings(state)


def only_taught(scores, count):
    """The sizes are rounded up, so the scores from `count` on belong to no meaning."""
    return jnp.where(jnp.arange(scores.shape[-1]) < count, scores, -1e9)


ADAM = optax.adam(RATE)


@jax.jit
def step(network, adam, sentences, labels, count, left_out, seed, number):
    def loss(network):
        keys = jax.random.split(jax.random.fold_in(jax.random.key(seed), number), len(sentences))
        scores = only_taught(jax.vmap(network, (0, None, 0))(sentences, left_out, keys), count)
        return optax.softmax_cross_entropy_with_integer_labels(scores, labels).mean()

    change, adam = ADAM.update(jax.grad(loss)(network), adam)
    return optax.apply_updates(network, change), adam


@jax.jit
def shares_of(network, sentences, count):
    return jax.nn.softmax(only_taught(jax.vmap(network)(sentences), count))


def batches(lengths, random):
    """Endless batches of sentences of about one length, in random order. The last batch of a length is filled up from the same length."""
    while True:
        ready, waiting = [], collections.defaultdict(list)
        for position in random.permutation(len(lengths)):
            waiting[lengths[position]].append(position)
            if len(waiting[lengths[position]]) == BATCH:
                ready.append(waiting.pop(lengths[position]))
        ready += [[*some, *random.choice(some, BATCH - len(some))] for some in waiting.values()]
        for number in random.permutation(len(ready)):
            yield np.array(ready[number])


def answers(taught, asked, settings):
    """The answers for each setting: of one network while settings are compared, and of the mean of three for a single setting."""
    said = lambda it: re.findall(r"[^\W_]+", it.command.lower())
    words = {word: UNKNOWN + 1 + number for number, word in enumerate(sorted({word for it in taught for word in said(it)}))}
    meanings = {label: number for number, label in enumerate(sorted({it.label() for it in taught}))}
    rounded_up = lambda count, step: -(-count // step) * step
    sizes = rounded_up(len(words) + 2, KNOWN), rounded_up(len(meanings), MEANINGS)

    def numbers(it):
        sentence = [words.get(word, UNKNOWN) for word in said(it)]
        return np.array(sentence + [PADDING] * (-len(sentence) % LONG))

    sentences, labels = [numbers(it) for it in taught], np.array([meanings[it.label()] for it in taught])
    alike = collections.defaultdict(list)
    for position, it in enumerate(asked):
        alike[len(numbers(it))].append(position)
    # Questions are batched by length as well.
    questions = [some[start : start + BATCH] for some in alike.values() for start in range(0, len(some), BATCH)]
    shares = {setting: np.zeros((len(asked), len(meanings))) for setting in settings}
    networks = NETWORKS if len(settings) == 1 else 1
    for seed in range(networks):
        for left_out in dict.fromkeys(left_out for left_out, _ in settings):
            random, network = np.random.default_rng(seed), Network(*sizes, jax.random.key(seed))
            adam, ends = ADAM.init(network), [steps for other, steps in settings if other == left_out]
            for number, batch in zip(range(1, max(ends) + 1), batches([len(it) for it in sentences], random)):
                some = np.array([sentences[position] for position in batch])
                network, adam = step(network, adam, some, labels[batch], len(meanings), left_out, seed, number)
                if number in ends:
                    for some in questions:
                        filled = np.array([numbers(asked[position]) for position in (some * BATCH)[:BATCH]])
                        rows = np.array(shares_of(network, filled, len(meanings)))[: len(some), : len(meanings)]
                        shares[left_out, number][some] += rows / networks
    names = list(meanings)
    # As with logistic regression, a thousandth is left for all meanings outside the training data.
    share = lambda it, row: 0.999 * row[meanings[it.label()]] if it.label() in meanings else 0.001
    return {key: [(names[row.argmax()] == it.label(), share(it, row)) for it, row in zip(asked, rows)] for key, rows in shares.items()}
