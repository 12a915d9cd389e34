"""Take submissions into nbgrader's course folder, and write marks into its gradebook.

nbgrader runs notebooks; it does not confine them. The engine is graded outside, by the judge, and
only its points are written into the gradebook, in the cells of the notebook `engine`.
"""
