"""What the program says about itself, where it has been built."""
import os
import re
import subprocess

PROGRAM = os.environ.get("SCREE_PROGRAM", "")
COMMANDS = ["run", "check", "info", "compare", "explain", "schema"]


def help_of(*arguments):
    result = subprocess.run([PROGRAM, *arguments, "--help"], capture_output=True, text=True, check=True)
    return result.stdout


def long_options(command):
    """The options of a command by its help: of the lines that begin with one, not of the examples."""
    heads = re.findall(r"(?m)^ +(-\S+)", help_of(command))
    return {option for head in heads for option in re.findall(r"--[a-z-]+", head)}
