#!/bin/bash
# The manual can be made, no link in it leads nowhere, and its words are those of the field.
rm -rf site
"$BOLIDE_SOURCE_DIR/scripts/docs" "$BOLIDE" site && grep -q "stiffness\|bulk_modulus" site/reference/eos.html
status=$?
"$BOLIDE_SOURCE_DIR/scripts/check-words" "$BOLIDE" || status=1
# A ball has a center and a radius.
if grep -n "ball: *[0-9]" -r "$BOLIDE_SOURCE_DIR/docs" "$BOLIDE_SOURCE_DIR/README.md"; then
    echo "FAILED: a ball without a table"
    status=1
fi
exit $status
