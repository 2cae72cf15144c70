talus_program(bench_coupling_window SOURCES coupling_window.cpp LINK talus_coupler fmt::fmt Threads::Threads)
