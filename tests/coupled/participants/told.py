"""The springs of examples/participants, after writing how it was started to the file that the variable TOLD names. With `late` it never joins, with
`slow` it never answers."""
import json
import os
import pathlib
import runpy
import sys
import time

import talus_participant

pathlib.Path(os.environ["TOLD"]).write_text(json.dumps({"arguments": sys.argv[1:], "folder": os.getcwd(), "environment": dict(os.environ)}))
if "late" in sys.argv:
    time.sleep(60)
if "slow" in sys.argv:
    talus_participant.Participant.answer = lambda self: time.sleep(60)
runpy.run_path(str(pathlib.Path(__file__).parents[3] / "examples/participants/springs.py"), run_name="__main__")
