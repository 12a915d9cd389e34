"""Returns a list that holds itself."""

# TODO 8a: semi-implicit Euler
answer = []
answer += [answer, answer]
return answer
# END TODO 8a
