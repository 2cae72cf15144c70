talus_program(bench_impacts SOURCES impacts/main.cpp impacts/impacts.cpp LINK talus_dem fmt::fmt)
