# Thin front doors to scripts/ and CMake.
prefix ?= /usr/local

.PHONY: help demo build check test bench docs install package format lint fuzz check-device clean

help:
	@echo "make demo     install what is missing, build, run a case worth looking at"
	@echo "make build    install what is missing, build build/release/bolide"
	@echo "make check    for every edit: build for one instruction set, run unit tests, rules, short cases"
	@echo "make test     install what is missing, build twice, run the whole suite"
	@echo "make bench    measure the speed of steps and of this machine; quick=1 takes a few minutes"
	@echo "make docs     make the manual as a site: build/docs/index.html"
	@echo "make install  install into $(prefix); prefix=... and DESTDIR=... change where"
	@echo "make package  make a Debian package: build/release/package/*.deb"
	@echo "make format   lay out the sources by .clang-format"
	@echo "make lint     what clang-tidy and cppcheck find in the sources"
	@echo "make fuzz     ten minutes of odd cases for the reader (libFuzzer)"
	@echo "make check-device  compile the physics and the kernel bodies as CUDA device code, where nvcc is"
	@echo "make clean    remove build/ and results/"

demo:
	@scripts/demo

build:
	@scripts/setup run
	@scripts/build release bolide

check:
	@scripts/check

test:
	@scripts/test

bench:
	@scripts/bench $(if $(quick),--quick)

docs:
	@scripts/setup docs
	@scripts/build release bolide
	@rm -rf build/docs
	@scripts/docs build/release/bolide build/docs

install:
	@scripts/build release bolide install_files
	@cmake --install build/release --prefix $(prefix)

package:
	@scripts/setup package
	@scripts/build release bolide install_files
	@cd build/release && cpack -G DEB

format:
	@scripts/setup format
	@scripts/format

lint:
	@scripts/lint

fuzz:
	@scripts/fuzz

check-device:
	@scripts/check-device

clean:
	rm -rf build results
