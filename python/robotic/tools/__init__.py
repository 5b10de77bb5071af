"""Helper modules of the reference as thin covers of functions of Kinegraph, and of h5py for HDF5 files."""
