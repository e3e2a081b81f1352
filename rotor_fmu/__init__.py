"""The shaft: train data, finite elements, reduction, exact time step, as an FMU."""
