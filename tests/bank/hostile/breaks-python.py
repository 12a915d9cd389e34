"""Has the interpreter itself fall over."""

# TODO 8a: semi-implicit Euler
code = (lambda: None).__code__
exec(code.replace(co_code=b"\x64\xff" * 100, co_stacksize=1))
# END TODO 8a
