talus_program(bench_settling SOURCES settling/settling.cpp settling/bed.cpp LINK talus_dem CLI11::CLI11 fmt::fmt)
