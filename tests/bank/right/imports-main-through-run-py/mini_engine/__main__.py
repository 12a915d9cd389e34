import runpy

runpy.run_module("run", run_name="__main__")
