"""Trains NLTK's IBM Model 2 from uniform tables on the sentence pairs in standard input, repeatedly.

Standard input: {"pairs": [[[machine tokens], [English words]], ...], "rounds": 10, "times": 9}
Standard output: {"seconds": [...], "t": [[token or null, word, probability], ...], "a": [[j, i, l, n, probability], ...]}
"""
import json
import sys
import time
from collections import defaultdict

from nltk.translate import AlignedSent, IBMModel2

request = json.load(sys.stdin)
words = len({word for _, english in request["pairs"] for word in english})


def tables():
    uniform = 1.0 / words
    t = defaultdict(lambda: defaultdict(lambda: uniform))
    a = defaultdict(lambda: defaultdict(lambda: defaultdict(lambda: defaultdict(float))))
    for machine, english in request["pairs"]:
        l, n = len(machine), len(english)
        for j in range(l + 1):
            for i in range(1, n + 1):
                a[j][i][l][n] = 1.0 / (l + 1)
    return {"translation_table": t, "alignment_table": a}


seconds = []
for _ in range(request["times"]):
    bitext = [AlignedSent(english, machine) for machine, english in request["pairs"]]
    start_tables = tables()
    start = time.perf_counter()
    model = IBMModel2(bitext, request["rounds"], probability_tables=start_tables)
    seconds.append(time.perf_counter() - start)

t = [[token, word, p] for word, row in model.translation_table.items() for token, p in row.items()]
a = [
    [j, i - 1, l, n, p]
    for j, by_i in model.alignment_table.items()
    for i, by_l in by_i.items()
    for l, by_n in by_l.items()
    for n, p in by_n.items()
]
json.dump({"seconds": seconds, "t": t, "a": a}, sys.stdout)
