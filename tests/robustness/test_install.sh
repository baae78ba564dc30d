#!/bin/bash
# What is installed works where it is put: the program with its materials and examples, the library with its
# headers, the Debian package.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"
unset BOLIDE_SHARE
build=$(dirname "$BOLIDE")

# verifies PREFIX: the program there runs an example that is there.
verifies() {
    "$1/bin/bolide" verify --short "$1/share/bolide/examples/riemann/gas/case.yaml" >said 2>&1 ||
        fail "$1/bin/bolide: $(cat said)"
    "$1/bin/bolide" new new --template riemann >said 2>&1 || fail "$1/bin/bolide new: $(cat said)"
    rm -rf new
}

rm -rf ./*
cmake --install "$build" --prefix "$PWD/there" >said 2>&1 || fail "cmake --install: $(cat said)"
verifies there
"$BOLIDE" schema | cmp - there/share/bolide/case.schema.json || fail "another schema"
for command in run check verify exact new schema help; do
    grep -q "^.SS bolide $command" there/share/man/man1/bolide.1 || fail "no $command in the man page"
done

cat >use.c <<'END'
#include <stdio.h>
#include "run/catalogue.h"
#include "run/run.h"
int main(int count, char **words)
{
    const char *const folders[] = {words[count - 1]};
    const struct case_options reading = {.form = "short", .library_paths = folders, .library_count = 1};
    struct simulation_case *input;
    struct run_result result;
    struct error *error = case_read(words[1], &reading, &bolide_catalogue, &input);
    if (!error)
        error = run_case(input, &(struct run_options){.threads = 1}, &result);
    printf("%s\n", error ? error_message(error, 0) : result.finished ? "finished" : "stopped");
    return error != NULL;
}
END
flags=$(PKG_CONFIG_PATH=$PWD/there/lib/pkgconfig pkg-config --cflags --libs bolide) || fail "pkg-config"
cc -std=gnu17 use.c $flags -o use >said 2>&1 || fail "a program with the library: $(cat said)"
[ "$(./use there/share/bolide/examples/riemann/gas/case.yaml there/share/bolide/materials)" = finished ] ||
    fail "a program with the library does not run a case"

cpack -G DEB --config "$build/CPackConfig.cmake" -B "$PWD/package" >said 2>&1 || fail "cpack: $(cat said)"
dpkg-deb -x package/*.deb root || fail "the package cannot be unpacked"
dpkg-deb -f package/*.deb Depends | grep -q libhdf5 || fail "the package does not say what it needs"
verifies root/usr
[ -e root/usr/lib/python3/dist-packages/bolide/__init__.py ] ||
    [ -n "$(ls root/usr/lib/python3*/site-packages/bolide/__init__.py 2>/dev/null)" ] ||
    fail "the package has no Python package"

exit $status
