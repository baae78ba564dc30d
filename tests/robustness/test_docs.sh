#!/bin/bash
# The manual can be made, and no link in it leads nowhere.
rm -rf site
"$BOLIDE_SOURCE_DIR/scripts/docs" "$BOLIDE" site && grep -q "stiffness\|bulk_modulus" site/reference/eos.html
status=$?
# A ball has a center and a radius.
if grep -n "ball: *[0-9]" -r "$BOLIDE_SOURCE_DIR/docs" "$BOLIDE_SOURCE_DIR/README.md"; then
    echo "FAILED: a ball without a table"
    status=1
fi
exit $status
