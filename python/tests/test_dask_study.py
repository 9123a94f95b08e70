"""A study on a cluster of two worker processes, one of which is killed on the way."""

from __future__ import annotations

import importlib
import os
import signal
import subprocess
from pathlib import Path
from types import ModuleType

import pytest

distributed = pytest.importorskip("distributed")

STUDY = ["--runs", "4", "--courses", "paper", "--agents", "goodbot", "--trainers", "balanced,punish-only"]
SHARDS = 8


@pytest.fixture
def example(root: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    # The workers are started with the same path, and import the example too.
    monkeypatch.syspath_prepend(root / "python/examples")
    return importlib.import_module("dask_study")


@pytest.mark.filterwarnings("ignore")
def test_a_study_outlives_a_worker_and_comes_to_the_same_bytes(example: ModuleType, cli: str, tmp_path: Path) -> None:
    if subprocess.run([cli, "study", "--help"], capture_output=True).returncode != 0:
        pytest.skip("this command line has no study")
    alone = subprocess.run([cli, "study", *STUDY, "--json"], check=True, capture_output=True).stdout
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0", local_directory=str(tmp_path)) as cluster,
        distributed.Client(cluster) as client,
    ):
        workers = client.run(os.getpid)
        assert len(set(workers.values())) == 2
        parts: dict[int, bytes] = {}
        for shard, lines in example.shards(client, cli, STUDY, SHARDS):
            if not parts:
                os.kill(next(iter(workers.values())), signal.SIGKILL)
            parts[shard] = lines
        assert len(parts) == SHARDS
    assert example.merged(cli, parts) == alone


def test_what_is_missing_is_told_before_the_work_and_leaves_no_file(example: ModuleType, cli: str, tmp_path: Path) -> None:
    out = tmp_path / "study.jsonl"
    assert example.what_is_missing(out, cli) is None
    assert "'no-such-goodbot' is not found; install it, or name it by --goodbot" in (example.what_is_missing(out, "no-such-goodbot") or "")
    assert "is missing; make it first" in (example.what_is_missing(tmp_path / "none" / "study.jsonl", cli) or "")
    example.write(out, b"study")
    assert out.read_bytes() == b"study" and list(tmp_path.iterdir()) == [out]
    assert "is there already" in (example.what_is_missing(out, cli) or "")
    with pytest.raises(RuntimeError, match="part 1 of 2: .*'nobody'"):
        example.run_shard(cli, ["--trainers", "nobody"], 1, 2)
