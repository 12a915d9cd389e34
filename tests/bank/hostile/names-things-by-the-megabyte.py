"""Types, functions and files whose names have a million letters, in an answer and in an error."""

# TODO 8a: semi-implicit Euler
return type("\x07" * 10**6, (), {})()
# END TODO 8a

# TODO 8b: velocity Verlet
def loud():
    raise type("\x07" * 10**6, (Exception,), {})("\x07" * 10**6)


code = compile("def f():\n    loud()", __file__, "exec").co_consts[0]
code = code.replace(co_name="\x07" * 10**6, co_filename=__file__)
exec(code, {"loud": loud})
# END TODO 8b
