"""Pictures of Scree's runs, from their HDF5 files alone. Used by plot_run.py and render.py."""
import os
import tempfile

# matplotlib wants a folder for its caches; a home that cannot be written to must not matter.
if not os.access(os.path.expanduser("~"), os.W_OK):
    os.environ.setdefault("MPLCONFIGDIR", os.path.join(tempfile.gettempdir(), f"matplotlib-{os.getuid()}"))
