/* The folder of the sources that the tests were built from, and what tests read in it. */
#ifndef BOLIDE_SOURCE_FOLDER_H
#define BOLIDE_SOURCE_FOLDER_H

extern const char source_folder[], materials_folder[], bad_cases_folder[], mistaken_material[],
    blast_wave_case[];

#endif
