talus_program(bench_acceleration SOURCES acceleration.cpp LINK talus_coupler fmt::fmt)
