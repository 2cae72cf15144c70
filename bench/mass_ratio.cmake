talus_program(bench_mass_ratio SOURCES mass_ratio.cpp LINK talus_coupler fmt::fmt Threads::Threads)
