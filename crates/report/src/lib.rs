//! Tables, figures, HTML and JSON of a diagnosis.
