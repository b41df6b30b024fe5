// Colours of the page's style, light or dark, for Plotly, which draws with its own.

const colour = name => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

const settings = {responsive: true, displaylogo: false, modeBarButtonsToRemove: ['select2d', 'lasso2d']};

const layoutOf = own => ({
  paper_bgcolor: 'rgba(0,0,0,0)', plot_bgcolor: 'rgba(0,0,0,0)', font: {color: colour('ink'), size: 12},
  hoverlabel: {bgcolor: colour('card'), font: {color: colour('ink')}}, showlegend: false,
  modebar: {bgcolor: 'rgba(0,0,0,0)', color: colour('muted'), activecolor: colour('ink')}, ...own
});

const axis = own => ({gridcolor: colour('line'), linecolor: colour('line'), zerolinecolor: colour('line'), ...own});
