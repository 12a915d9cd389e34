"""The version of pygame-ce that this copy equals."""

vernum = (2, 5, 8)
ver = "2.5.8"
