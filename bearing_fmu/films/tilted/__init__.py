"""V1: the film between a tilted journal and its bore."""
