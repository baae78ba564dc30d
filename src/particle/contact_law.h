/* Contact laws between groups of bodies, as bits. */
#ifndef BOLIDE_CONTACT_LAW_H
#define BOLIDE_CONTACT_LAW_H

/* The law between two contact groups: bits, and above them which surface; zero is full contact. */
enum contact_law {
    LAW_SLIP = 1,       /* no shear traction but friction */
    LAW_NO_TENSION = 2, /* the contact opens instead of pulling */
    LAW_SURFACE = 4,    /* times the index of the surface */
};

#endif
