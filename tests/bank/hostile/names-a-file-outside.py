"""Its error comes from a file outside, by its own word, with letters that no text can hold."""

# TODO 8a: semi-implicit Euler
import os

outside = os.path.dirname(__file__) + "/../../../../../../../../etc/passwd"
exec(compile("\n\nraise ValueError('\\udc80 \\u202e =1+1 ::error::x')", outside, "exec"))
# END TODO 8a
