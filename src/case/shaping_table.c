/* The keys that shape a case before its table reads it. */
#include "case/internal.h"

const struct parameter case_shaping_table[] = {
    {.key = "include",
     .kind = PARAMETER_NAMES,
     .standard = OPTIONAL,
     .help = "files whose keys this file extends and overrides; paths are relative to this file's "
             "folder"},
    {.key = "let",
     .kind = PARAMETER_MAP,
     .standard = OPTIONAL,
     .help = "names for expressions, in order: {speed: 1 km/s, plate: 4 mm, way: 2*plate}"},
    {.key = "short",
     .kind = PARAMETER_TABLE,
     .standard = OPTIONAL,
     .help = "keys of the case, merged over it by --short: {resolution: 1 mm, let: {plate: 2 mm}}"},
    {.key = "long",
     .kind = PARAMETER_TABLE,
     .standard = OPTIONAL,
     .help = "keys of the case, merged over it by --long, for a finer or longer run"},
    {.key = "sweep",
     .kind = PARAMETER_MAP,
     .standard = OPTIONAL,
     .help =
         "names of let, paths, or include, each with the values to run with: {speed: [1 km/s, 2 "
         "km/s]}; those that change together in a map: {gas: {gamma: [1.4, 3], front: [2 mm, 3 "
         "mm]}}"},
    {.key = "walls",
     .kind = PARAMETER_MAP,
     .standard = OPTIONAL,
     .help =
         "another spelling of reflecting `boundaries`: {left: {mirror: x, at: 0 mm, side: low}}"},
    {.key = "outflows",
     .kind = PARAMETER_MAP,
     .standard = OPTIONAL,
     .help = "another spelling of outflows among `boundaries`: {end: {across: x, at: 1 m, side: "
             "high}}"},
    {.key = "obstacles",
     .kind = PARAMETER_MAP,
     .standard = OPTIONAL,
     .help = "another spelling of rigid bodies among `boundaries`: {block: {box: ...}}"},
    PARAMETER_END,
};
