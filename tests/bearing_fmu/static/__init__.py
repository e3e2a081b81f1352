"""Static investigations of a bearing."""
