/* The files, put into the program by the assembler. */
#include "page/assets.h"

#define ASSET(name, path)                                           \
    __asm__(".pushsection .rodata\n.global " #name "\n" #name ":\n" \
            ".incbin \"" path "\"\n.byte 0\n.popsection\n")

ASSET(asset_dygraphs, BOLIDE_DYGRAPHS "/dygraph.min.js");
ASSET(asset_dygraphs_style, BOLIDE_DYGRAPHS "/dygraph.min.css");
ASSET(asset_plots, BOLIDE_PAGE_SOURCE "/plots.js");
ASSET(asset_viewer, BOLIDE_PAGE_SOURCE "/viewer.js");
ASSET(asset_viewer_controls, BOLIDE_PAGE_SOURCE "/viewer.html");
