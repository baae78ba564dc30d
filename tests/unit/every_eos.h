/* One of each equation of state, by kind, with the constants of its header's sample. */
#ifndef BOLIDE_TEST_EVERY_EOS_H
#define BOLIDE_TEST_EVERY_EOS_H

#include "material/eos.h"

#define EVERY_EOS(name) [EOS_##name] = {EOS_##name, {.name = EOS_##name##_SAMPLE}},
static const struct eos all[EOS_KINDS] = {EOS_LIST(EVERY_EOS)};
#undef EVERY_EOS

#endif
