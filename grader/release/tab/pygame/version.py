"""The version of pygame-ce that this one is compared with."""

vernum = (2, 5, 8)
ver = "2.5.8"
