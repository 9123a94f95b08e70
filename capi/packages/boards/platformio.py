# PlatformIO runs this to find the archive for the board's processor.
from pathlib import Path

Import("env")  # noqa: F821: PlatformIO defines it


def folder(source, board, flags):
    """The folder of the archive: the processor's, or the one for the board's float convention within it."""
    for name in (board.get("build.mcu", ""), board.get("build.cpu", "")):
        if not name or not (source / name).is_dir():
            continue
        kinds = sorted(kind.name for kind in (source / name).iterdir() if kind.is_dir())
        abi = next((flag.partition("=")[2] for flag in flags if str(flag).startswith("-mfloat-abi=")), "soft")
        return source / name / next((kind for kind in kinds if kind.endswith("-" + abi)), "")
    return None


source = Path.cwd() / "src"
board = env.BoardConfig()  # noqa: F821
found = folder(source, board, env.Flatten(env.get("CCFLAGS", [])))  # noqa: F821
if found is None:
    known = ", ".join(sorted(path.name for path in source.iterdir() if path.is_dir()))
    raise SystemExit(f"goodbot has no archive for {board.get('build.mcu', '')} {board.get('build.cpu', '')}; it has {known}")
env.Append(LIBPATH=[str(found)], LIBS=["goodbot"])  # noqa: F821
