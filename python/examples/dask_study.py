"""A study on many machines: `goodbot study` in parts, which Dask spreads over a cluster.

    python dask_study.py --out study.jsonl --shards 64 -- --runs 1000 --trainers balanced,punish-only
    python dask_study.py --out study.jsonl --shards 64 --scheduler tcp://host:8786 -- --runs 1000

The arguments after `--` go to `goodbot study`. Without `--scheduler`, a cluster of this machine's cores is made; Dask says where its
dashboard is. If a worker is lost, its part is done again elsewhere. Parts are deterministic: the merged study is, byte for byte, the one
that a single machine would write.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

try:
    from distributed import Client, as_completed
except ImportError:
    sys.exit("Dask is missing; install it with: pip install 'goodbot[dask]'")


def run_shard(program: str, arguments: Sequence[str], shard: int, of: int) -> bytes:
    """One part of the study, counted from 1: the lines that `goodbot study --shard` writes. It runs on a worker."""
    command = [program, "study", *arguments, "--shard", f"{shard}/{of}", "--json"]
    ran = subprocess.run(command, capture_output=True)
    if ran.returncode != 0:
        raise RuntimeError(f"part {shard} of {of}: {ran.stderr.decode(errors='replace').strip()}")
    return ran.stdout


def shards(client: Client, program: str, arguments: Sequence[str], count: int) -> Iterator[tuple[int, bytes]]:
    """All parts with their numbers, as they come."""
    futures = {client.submit(run_shard, program, list(arguments), shard, count, pure=False): shard for shard in range(1, count + 1)}
    for future in as_completed(futures):
        yield futures[future], future.result()


def merged(program: str, parts: dict[int, bytes]) -> bytes:
    """The parts as one study."""
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder, f"{shard}.jsonl") for shard in sorted(parts)]
        for file, shard in zip(files, sorted(parts), strict=True):
            file.write_bytes(parts[shard])
        return subprocess.run([program, "study", "--merge", *map(str, files), "--json"], check=True, capture_output=True).stdout


def what_is_missing(out: Path, program: str) -> str | None:
    """What must be done before a study can begin, or None. It is checked before the hours of work."""
    if out.exists():
        return f"{out} is there already; name another file, or remove it"
    if not out.parent.is_dir():
        return f"the folder {out.parent} is missing; make it first"
    if shutil.which(program) is None:
        return f"the command line {program!r} is not found; install it, or name it by --goodbot"
    return None


def write(out: Path, study: bytes) -> None:
    """Writes a file whole or not at all, so that no half-written file is in the way of the next try."""
    with tempfile.NamedTemporaryFile(dir=out.parent, delete=False) as file:
        file.write(study)
    try:
        os.chmod(file.name, 0o644)
        os.rename(file.name, out)
    except OSError:
        os.unlink(file.name)
        raise


def main() -> None:
    """Runs a study and writes it."""
    parser = argparse.ArgumentParser(description="goodbot study on a Dask cluster")
    parser.add_argument("--out", type=Path, required=True, help="the file for the merged study; it must not exist yet")
    parser.add_argument("--shards", type=int, default=16, help="how many parts (several for each core, so that little is lost with one)")
    parser.add_argument("--scheduler", help="the address of a Dask scheduler; a cluster of this machine without it")
    parser.add_argument("--goodbot", default="goodbot", help="the command line, as the workers find it")
    parser.add_argument("arguments", nargs="*", metavar="-- ...", help="the arguments of goodbot study")
    options = parser.parse_args()
    if missing := what_is_missing(options.out, options.goodbot):
        parser.error(missing)
    with Client(options.scheduler) as client:
        print(f"dashboard: {client.dashboard_link}")
        parts: dict[int, bytes] = {}
        for shard, lines in shards(client, options.goodbot, options.arguments, options.shards):
            parts[shard] = lines
            print(f"{len(parts)} of {options.shards} parts", end="\r", flush=True)
        write(options.out, merged(options.goodbot, parts))
    print(f"{options.shards} parts in {options.out}")


if __name__ == "__main__":
    main()
