/* report.html: the results of a run as one page that needs nothing beside itself: no network, no
 * other file. It is made from the files of the results folder alone, by the run at its end and by
 * `bolide report`, and shows what is there. */
#ifndef BOLIDE_PAGE_H
#define BOLIDE_PAGE_H

#include "base/error.h"

/* Writes FOLDER/report.html, of a sweep or a calibration where FOLDER holds its table (sweep.csv,
 * calibrate-keys.csv), else of a run.
 * ERROR_INPUT when it holds no results of either (no run.log). */
struct error *page_write(const char *folder);

#endif
