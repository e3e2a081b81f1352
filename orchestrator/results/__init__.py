"""What a run leaves: record, statistics, summary, certificate, figures, folder."""
