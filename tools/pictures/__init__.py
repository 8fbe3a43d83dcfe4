"""Pictures of Scree's runs, from their HDF5 files alone. Used by plot_run.py and render.py."""
