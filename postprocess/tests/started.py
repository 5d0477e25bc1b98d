"""Runs a script as a user does, but within this process, so that what the scripts import is imported once."""

import contextlib
import io
import runpy
import subprocess
import sys
import traceback
from pathlib import Path
from unittest import mock

SCRIPTS = Path(__file__).resolve().parents[1]


def run(script: str, *arguments: object) -> subprocess.CompletedProcess:
    """The exit code of a script in `postprocess` and what it printed."""
    command = [str(SCRIPTS / script), *map(str, arguments)]
    out, err = io.StringIO(), io.StringIO()
    code: object = None
    with mock.patch.object(sys, "argv", command), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            runpy.run_path(command[0], run_name="__main__")
        except SystemExit as ended:
            code = ended.code
        except Exception:
            traceback.print_exc()
            code = 1
    if isinstance(code, str):
        print(code, file=err)
        code = 1
    return subprocess.CompletedProcess(command, int(code or 0), out.getvalue(), err.getvalue())
