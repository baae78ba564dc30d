#!/bin/bash
# The manual can be made, and no link in it leads nowhere.
rm -rf site
"$BOLIDE_SOURCE_DIR/scripts/docs" "$BOLIDE" site && grep -q "stiffness\|bulk_modulus" site/reference/eos.html
