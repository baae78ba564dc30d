# Thin front doors to scripts/ and CMake.
.PHONY: help demo build test bench format clean

help:
	@echo "make demo    install what is missing, build, run a case worth looking at"
	@echo "make build   install what is missing, build build/release/bolide"
	@echo "make test    install what is missing, build twice, run the whole suite"
	@echo "make bench   measure the speed of the rooms that matter"
	@echo "make format  lay out the sources by .clang-format"
	@echo "make clean   remove build/ and results/"

demo:
	@scripts/demo

build:
	@scripts/setup run
	@scripts/build release bolide

test:
	@scripts/test

bench:
	@scripts/bench

format:
	@scripts/setup format
	@scripts/format

clean:
	rm -rf build results
