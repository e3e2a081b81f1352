"""What makes a bladeloss model an FMU: the port, the facade base, the builder.

The physics packages know nothing of FMI; this package is the only one that
touches pythonfmu.  ``port`` is the one declaration of the interface.  The built
``*.fmu`` files and the README for users of other tools lie in this folder, too.
"""
