# What the tests that run the program share: a failure is told and ends the test with 1, and whether
# two runs wrote the same.
set -u
status=0
fail() {
    echo "FAILED: $*"
    status=1
}

# Waits for all FILEs that the run with the process id PID writes, or for its end: await PID FILE...
await() {
    local file
    for file in "${@:2}"; do
        while [ ! -s "$file" ] && kill -0 "$1" 2>/dev/null; do sleep 0.02; done
    done
}

hash_of() { grep -o '"hash","[0-9a-f]*"' "$1/summary.csv"; }
# To the last bit, but for what tells of the running itself; further arguments: what diff leaves out.
same() {
    [ -n "$(hash_of "$1")" ] && [ "$(hash_of "$1")" = "$(hash_of "$2")" ] || return 1
    diff -rq -x summary.csv -x run.log -x report.html -x checkpoint.h5 -x case.yaml "${@:3}" "$1" "$2"
}
# The same where particles were sorted at other times: snapshots hold them in the order of storage.
same_but_for_order() { same "$1" "$2" -x snapshots; }
