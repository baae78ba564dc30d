#!/bin/bash
# bolide new: every template becomes a case that is right, and nothing is overwritten.
. "$BOLIDE_SOURCE_DIR/tests/robustness/common.sh"

rm -rf ./*
for template in "$BOLIDE_SOURCE_DIR"/templates/*.yaml; do
    name=$(basename "$template" .yaml)
    "$BOLIDE" new "$name" --template "$name" >said || fail "new --template $name ended with $?"
    grep -q "$name/case.yaml" said || fail "new does not say where: $(cat said)"
    cmp "$template" "$name/case.yaml" || fail "$name/case.yaml is not the template"
    "$BOLIDE" check "$name/case.yaml" >said 2>&1 || fail "check $name: $(cat said)"
done

"$BOLIDE" new usual/of/mine >said || fail "new ended with $?"
cmp "$BOLIDE_SOURCE_DIR/templates/impact.yaml" usual/of/mine/case.yaml || fail "impact is not the usual template"

rm -r long-rod
"$BOLIDE" new long-rod >said || fail "new long-rod ended with $?"
cmp "$BOLIDE_SOURCE_DIR/templates/long-rod.yaml" long-rod/case.yaml || fail "its name chooses no template"
grep -q "from the template long-rod" said || fail "new does not say which template: $(cat said)"

echo "format: 1 # mine" >usual/of/mine/case.yaml
"$BOLIDE" new usual/of/mine >said 2>&1
[ $? = 2 ] || fail "new over a case does not end with 2"
grep -q "exists already" said || fail "$(cat said)"
[ "$(cat usual/of/mine/case.yaml)" = "format: 1 # mine" ] || fail "new changed a case"

"$BOLIDE" new other --template impcat >said 2>&1
[ $? = 2 ] || fail "an unknown template does not end with 2"
grep -q 'did you mean "impact"' said || fail "$(cat said)"
[ -e other ] && fail "an unknown template left a folder"

exit $status
