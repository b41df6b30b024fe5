"""A table that reads the same on a page and in a terminal."""
import dataclasses
import html


@dataclasses.dataclass(frozen=True)
class Column:
    """css: class of its cells on the page; `text` aligns left."""
    title: str
    unit: str = ""
    css: str = ""

    @property
    def is_text(self):
        return self.css.startswith("text")


@dataclasses.dataclass
class Table:
    """rows: tuples of strings, or of (string, css class) where the page marks a cell."""
    title: str
    columns: list
    rows: list

    def to_html(self):
        head = "".join(f'<th class="{column.css}">{html.escape(column.title)}'
                       + (f"<br>[{html.escape(column.unit)}]" if column.unit else "") + "</th>"
                       for column in self.columns)
        body = "\n".join("<tr>" + "".join(self.html_cell(cell, column) for cell, column in zip(row, self.columns))
                         + "</tr>" for row in self.rows)
        return (f'<h3>{html.escape(self.title)}</h3>\n<div class="table"><table>\n'
                f"<thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody></table></div>")

    @staticmethod
    def html_cell(cell, column):
        content = html.escape(cell_text(cell))
        if not isinstance(cell, str):
            content = f'<span class="{cell[1]}">{content}</span>'
        return f'<td class="{column.css}">{content}</td>'

    def to_text(self):
        lines = [[column.title for column in self.columns],
                 [f"[{column.unit}]" if column.unit else "" for column in self.columns],
                 *([cell_text(cell) for cell in row] for row in self.rows)]
        widths = [max(len(line[index]) for line in lines) for index in range(len(self.columns))]
        aligned = ["  ".join(cell.ljust(width) if column.is_text else cell.rjust(width)
                             for cell, width, column in zip(line, widths, self.columns)).rstrip() for line in lines]
        return "\n".join([self.title, *aligned[:2], "-" * max(map(len, aligned)), *aligned[2:]])


def cell_text(cell):
    return cell if isinstance(cell, str) else cell[0]
