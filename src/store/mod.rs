//! SQLite and blobs: all SQL and all files of the service. (to be written)
