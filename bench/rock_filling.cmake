talus_program(bench_rock_filling SOURCES rock_filling.cpp LINK talus_dem fmt::fmt)
