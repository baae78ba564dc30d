/* Files that pages hold, as they were when the program was built. */
#ifndef BOLIDE_PAGE_ASSETS_H
#define BOLIDE_PAGE_ASSETS_H

/* Texts with a zero at their end. */
extern const char asset_dygraphs[],
    asset_dygraphs_style[]; /* MIT licence; Debian's libjs-dygraphs */
extern const char asset_plots[], asset_viewer[], asset_viewer_controls[];

#endif
