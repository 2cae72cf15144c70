"""An independent structural solver for cable nets in NumPy and SciPy, written from the formulas and not from fem_solver."""
