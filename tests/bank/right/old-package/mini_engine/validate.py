"""The guard against bad input. Nothing to do here."""


def require(ok, field, value, rule):
    """Raise ValueError naming the field, its value and the rule, unless ok is true."""
    if not ok:
        raise ValueError(f"{field} is {value}, but it must be {rule}.")
