"""Runs the package's platformio.py as PlatformIO does, for boards given by their description alone: `platformio.py PACKAGE`."""

import os
import runpy
import sys
from pathlib import Path


class Environment:
    """The environment of a build."""

    def __init__(self, board, flags):
        self.board, self.flags, self.appended = board, flags, {}

    def BoardConfig(self):
        return self.board

    def get(self, _name, _otherwise):
        return self.flags

    def Flatten(self, flags):
        return flags

    def Append(self, **variables):
        self.appended.update(variables)


def linked(board, flags=()):
    """The folder that is searched for the archive, below `src`."""
    environment = Environment(board, list(flags))
    runpy.run_path("platformio.py", {"Import": lambda _name: None, "env": environment})
    assert environment.appended["LIBS"] == ["goodbot"]
    (folder,) = environment.appended["LIBPATH"]
    return Path(folder).relative_to(Path.cwd() / "src").as_posix()


os.chdir(sys.argv[1])
assert linked({"build.mcu": "rp2040", "build.cpu": "cortex-m0plus"}) == "rp2040"
assert linked({"build.mcu": "nrf52840", "build.cpu": "cortex-m4"}, ["-mfloat-abi=hard"]) == "cortex-m4/fpv4-sp-d16-hard"
assert linked({"build.mcu": "stm32f407vgt6", "build.cpu": "cortex-m4"}) == "cortex-m4"
assert linked({"build.mcu": "stm32h743", "build.cpu": "cortex-m7"}, ["-mfloat-abi=softfp"]) == "cortex-m7/fpv5-d16-softfp"
assert linked({"build.mcu": "esp32c3"}) == "esp32c3"
try:
    linked({"build.mcu": "atmega328p"})
except SystemExit as refusal:
    assert "atmega328p" in str(refusal) and "cortex-m4" in str(refusal), refusal
else:
    raise AssertionError("an archive for a processor that has none")
print("PlatformIO finds the archive of each board")
