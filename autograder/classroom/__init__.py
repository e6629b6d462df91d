"""What only instructors have: classes, downloads, gradebooks, pages and audits. Student archives leave it out."""
