talus_program(bench_settling SOURCES settling/settling.cpp settling/bed.cpp settling/machine.cpp LINK talus_dem CLI11::CLI11 fmt::fmt)
